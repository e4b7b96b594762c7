"""The demo, once from end to end on the small flat; the report is read by a parser, its numbers are held against the result."""

import base64
import json
import re
from html.parser import HTMLParser

import cv2
import numpy as np
import pytest

from priorlab.buildings.floor_plans import load_floor_plan
from priorlab.cli import main

VOID = {"meta", "img", "br", "link", "input", "hr"}


class Page(HTMLParser):
    """Collects what matters and checks that tags close in order."""

    def __init__(self, text):
        super().__init__()
        self.open, self.images, self.links, self.headings, self.ids = [], [], [], [], []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        if tag not in VOID:
            self.open.append(tag)
        if tag == "img":
            self.images.append(attrs)
        self.links += [attrs[name] for name in ("href", "src", "srcset", "action", "data") if name in attrs]
        self.ids += [attrs["id"]] if "id" in attrs else []
        self.headings += [tag] if re.fullmatch("h[1-6]", tag) else []

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


@pytest.fixture(scope="module")
def demo(tmp_path_factory):
    """The folder that the demo leaves, its code, what it printed."""
    import contextlib
    import io

    out, printed = tmp_path_factory.mktemp("demo") / "out", io.StringIO()
    with contextlib.redirect_stdout(printed):
        code = main(["demo", "--building", "small_flat", "--out", str(out)])
    return out, code, printed.getvalue()


@pytest.fixture(scope="module")
def page(demo):
    return (demo[0] / "report.html").read_text()


@pytest.fixture(scope="module")
def numbers(demo):
    return json.loads((demo[0] / "numbers.json").read_text())


def test_demo_goes_all_the_way(demo, numbers):
    assert demo[1] == 0
    assert numbers["stopped"] is None
    assert all(numbers[stage] is not None for stage in ("walls", "mapping", "search", "fastslam"))


def test_demo_shows_progress_and_the_numbers_that_matter(demo, numbers):
    printed = demo[2]
    for words in ("corners, doors and walls", "posterior map", "Pareto", "FastSLAM through", r"  step \d+ of \d+", "report"):
        assert re.search(rf"\[ *[\d.]+ s\] .*{words}", printed), words
    assert f"{numbers['walls']['score']['precision']:.3f}, {numbers['walls']['score']['recall']:.3f}" in printed
    assert f"{numbers['mapping']['with_plan']['f2']:.3f}" in printed
    assert f"{numbers['fastslam']['ate_m']:.2f} m" in printed


def test_report_is_whole_html(page):
    read = Page(page)
    assert page.startswith("<!DOCTYPE html>") and '<html lang="en">' in page
    assert read.headings[0] == "h1" and read.headings.count("h1") == 1 and "h3" not in read.headings
    assert len(set(read.ids)) == len(read.ids)


def test_report_needs_no_network(page):
    assert re.findall(r"(?:https?:|ftp:)?//[\w.]", re.sub(r"base64,[A-Za-z0-9+/=]+", "", page)) == []
    for link in Page(page).links:
        assert link.startswith(("data:image/png;base64,", "#"))


def test_report_links_lead_somewhere(page):
    read = Page(page)
    assert {link[1:] for link in read.links if link.startswith("#")} <= set(read.ids)


def test_report_pictures_have_words_and_show_something(page):
    images = Page(page).images
    assert len(images) >= 14
    for image in images:
        assert len(image["alt"].split()) >= 5
        png = base64.b64decode(image["src"].removeprefix("data:image/png;base64,"))
        pixels = cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_GRAYSCALE)
        assert pixels.std() > 5, image["alt"]
    assert len({image["alt"] for image in images}) == len(images)


def test_report_says_the_convention_on_top_and_how_it_was_made_at_the_end(page):
    top, end = page.split("<main>")[0], page.split("</main>")[1]
    assert "Every probability here is P(the cell is empty)" in top
    assert "priorlab demo --building small_flat" in end and "Seed 0" in end and "numpy" in end


def test_report_numbers_are_those_of_the_result(page, numbers):
    def shown(name, score):
        cells = (f"{100 * score['precision']:.1f} %", f"{100 * score['recall']:.1f} %", f"{score['f2']:.3f}")
        return f'<th scope="row">{name}</th>' + "".join(f"<td>{cell}</td>" for cell in cells) in page

    assert shown("extracted walls", numbers["walls"]["score"])
    for kind, names in (
        ("mapping", ("the plan alone, no reading", "readings alone, no plan", "plan and readings")),
        ("fastslam", ("the plan alone, no scan", "scans alone, no plan", "plan and scans")),
    ):
        for name, key in zip(names, ("prior_alone", "without_plan", "with_plan"), strict=True):
            assert shown(name, numbers[kind][key]), (kind, name)
    assert f"The absolute trajectory error (ATE) is {numbers['fastslam']['ate_m']:.2f} m" in page
    assert f"Highest F2 {numbers['search']['best']['f_beta']['value']:.3f}" in page


def test_numbers_hold_the_definition_of_the_score(numbers):
    for score in (numbers["walls"]["score"], numbers["mapping"]["with_plan"], numbers["fastslam"]["without_plan"]):
        precision, recall = score["tp"] / (score["tp"] + score["fp"]), score["tp"] / (score["tp"] + score["fn"])
        assert score["precision"] == pytest.approx(precision) and score["recall"] == pytest.approx(recall)
        assert score["f2"] == pytest.approx(5 * precision * recall / (4 * precision + recall))
    truth = load_floor_plan("small_flat").truth
    counted = numbers["walls"]["score"]
    assert counted["tp"] + counted["fn"] == int((truth.walls & ~truth.ignore).sum())


def test_the_plan_pays_in_a_quick_survey(numbers):
    assert numbers["mapping"]["mean_looks"] < 3
    assert numbers["mapping"]["gain_percent"] >= 20  # method-maps 4: safe at 3 px cells in a quick survey


def test_the_exact_front_is_not_beaten_by_the_search(numbers):
    search = numbers["search"]
    assert search["searched_front"]["hypervolume"] <= search["exact_front"]["hypervolume"] + 1e-9
