"""Writing leaves the old or the new, never a half, and never takes what is the user's."""

import os
from pathlib import Path

import pytest

from priorlab.core.files import check_free, new_folder, write_file


def names(folder):
    """What a folder holds, hidden files too."""
    return sorted(path.name for path in folder.iterdir())


def test_new_folder_appears_whole(tmp_path):
    with new_folder(tmp_path / "deep" / "out") as folder:
        (folder / "a.txt").write_text("a")
        assert not (tmp_path / "deep" / "out").exists()
    assert names(tmp_path / "deep") == ["out"]
    assert (tmp_path / "deep" / "out" / "a.txt").read_text() == "a"


def test_new_folder_leaves_nothing_after_an_error(tmp_path):
    with pytest.raises(RuntimeError, match="on the way"), new_folder(tmp_path / "out") as folder:
        (folder / "a.txt").write_text("half")
        raise RuntimeError("on the way")
    assert names(tmp_path) == []


def test_new_folder_does_not_overwrite(tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "mine.txt").write_text("mine")
    with pytest.raises(FileExistsError, match="out exists already.*--force"), new_folder(tmp_path / "out"):
        pytest.fail("the block must not run")
    assert (tmp_path / "out" / "mine.txt").read_text() == "mine"


def make_own(place):
    """A folder that priorlab made, with a file in it."""
    with new_folder(place) as folder:
        (folder / "old.txt").write_text("old")


def test_new_folder_replaces_its_own_with_force(tmp_path):
    make_own(tmp_path / "out")
    with new_folder(tmp_path / "out", force=True) as folder:
        (folder / "new.txt").write_text("new")
    assert names(tmp_path) == ["out"] and names(tmp_path / "out") == [".priorlab", "new.txt"]


@pytest.mark.parametrize("force", [False, True])
def test_new_folder_takes_an_empty_place(tmp_path, force):
    (tmp_path / "out").mkdir()
    with new_folder(tmp_path / "out", force) as folder:
        (folder / "new.txt").write_text("new")
    assert names(tmp_path / "out") == [".priorlab", "new.txt"]


def test_new_folder_leaves_a_link_to_an_empty_place(tmp_path):
    (tmp_path / "there").mkdir()
    (tmp_path / "out").symlink_to(tmp_path / "there")
    with pytest.raises(FileExistsError, match="out exists already"), new_folder(tmp_path / "out"):
        pytest.fail("the block must not run")


def test_new_folder_says_beforehand_that_a_mounted_disk_cannot_be_replaced(tmp_path, monkeypatch):
    (tmp_path / "out").mkdir()
    monkeypatch.setattr("os.path.ismount", lambda place: True)
    with pytest.raises(ValueError, match="must not be a mounted disk"), new_folder(tmp_path / "out"):
        pytest.fail("the block must not run")


def test_new_folder_does_not_replace_the_empty_working_folder(tmp_path, monkeypatch):
    (tmp_path / "out").mkdir()
    monkeypatch.chdir(tmp_path / "out")
    with pytest.raises(ValueError, match="must not hold .*: it would be replaced"), new_folder("."):
        pytest.fail("the block must not run")


@pytest.mark.parametrize("make", [lambda place: place.write_text("mine"), lambda place: (place / "thesis").mkdir(parents=True)])
def test_new_folder_never_replaces_what_it_did_not_make(tmp_path, make):
    make(tmp_path / "out")
    with (
        pytest.raises(FileExistsError, match="not a folder that priorlab made"),
        new_folder(tmp_path / "out", force=True),
    ):
        pytest.fail("the block must not run")
    assert names(tmp_path) == ["out"]


@pytest.mark.parametrize("force", [False, True])
def test_new_folder_leaves_what_came_up_in_the_meantime(tmp_path, force):
    with pytest.raises(FileExistsError), new_folder(tmp_path / "out", force):
        (tmp_path / "out").mkdir()
        (tmp_path / "out" / "mine.txt").write_text("mine")
    assert names(tmp_path) == ["out"] and names(tmp_path / "out") == ["mine.txt"]


def test_new_folder_keeps_the_working_folder_and_what_is_needed(tmp_path, monkeypatch):
    make_own(tmp_path / "out")
    for keep, here in (([tmp_path / "out" / "old.txt"], tmp_path), ([], tmp_path / "out")):
        monkeypatch.chdir(here)
        with pytest.raises(ValueError, match="--force would remove it"), new_folder(tmp_path / "out", force=True, keep=keep):
            pytest.fail("the block must not run")
    assert (tmp_path / "out" / "old.txt").exists()


def test_new_folder_puts_the_old_one_back_when_the_rename_fails(tmp_path, monkeypatch):
    make_own(tmp_path / "out")
    rename = Path.rename

    def fail_into_place(self, target):
        if self.name.startswith(".out-") and Path(target).name == "out":
            raise OSError("disk gone")
        return rename(self, target)

    with pytest.raises(OSError, match="disk gone"), new_folder(tmp_path / "out", force=True):
        monkeypatch.setattr(Path, "rename", fail_into_place)
    assert names(tmp_path) == ["out"] and (tmp_path / "out" / "old.txt").read_text() == "old"


def test_new_folder_needs_a_name_and_a_place_to_write(tmp_path):
    (tmp_path / "file").write_text("a")
    for place, sentence in (("", "must have a name"), (tmp_path / "file" / "out", "where one can write")):
        with pytest.raises(ValueError, match=sentence), new_folder(place):
            pytest.fail("the block must not run")


def test_new_folder_keeps_the_old_one_when_forced_work_fails(tmp_path):
    make_own(tmp_path / "out")
    with pytest.raises(RuntimeError, match="fails"), new_folder(tmp_path / "out", force=True):
        raise RuntimeError("fails")
    assert names(tmp_path) == ["out"] and (tmp_path / "out" / "old.txt").read_text() == "old"


def test_write_file_replaces_in_one_step(tmp_path):
    write_file(tmp_path / "a.txt", "one")
    write_file(tmp_path / "a.txt", b"two")
    assert names(tmp_path) == ["a.txt"] and (tmp_path / "a.txt").read_bytes() == b"two"


def test_write_file_keeps_the_old_one_when_the_rename_fails(tmp_path, monkeypatch):
    write_file(tmp_path / "a.txt", "old")

    def fail(*_):
        raise OSError("disk full")

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(OSError, match="disk full"):
        write_file(tmp_path / "a.txt", "new")
    assert names(tmp_path) == ["a.txt"] and (tmp_path / "a.txt").read_text() == "old"


def test_written_files_can_be_read_by_others(tmp_path):
    write_file(tmp_path / "a.txt", "a")
    assert (tmp_path / "a.txt").stat().st_mode & 0o777 == 0o644


def test_check_free_is_silent_where_nothing_stands(tmp_path):
    assert check_free(tmp_path / "new") is None
    with pytest.raises(FileExistsError, match="exists already"):
        check_free(tmp_path)
    assert check_free(tmp_path, force=True) is None
