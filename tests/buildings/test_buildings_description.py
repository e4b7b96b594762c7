"""A description's mistakes are told in one sentence; what is right is read as written."""

import pytest

from priorlab.buildings.description import parse_description, read_description
from priorlab.buildings.layout import lay_out

SQUARE = 'walls = [{ style = "outer", outline = [[0, 0], [4, 0], [4, 3], [0, 3]] }]\n'
HUT = "metres_per_pixel = 0.1\n" + SQUARE


def test_parse_description_reads_values_and_defaults():
    text = HUT + 'doors = [{ at = [2, 0.15], width = 1, hinge = "west", opens = "north" }]\n[styles.outer]\nthickness = 0.3\n'
    hut = parse_description(text, name="hut")
    assert hut.name == "hut" and hut.metres_per_pixel == 0.1
    assert hut.walls[0].outline == ((0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0))
    assert hut.styles["outer"].thickness == 0.3 and hut.styles["outer"].look == "filled"
    door = hut.doors[0]
    assert (door.at, door.width, door.kind, door.open) == ((2.0, 0.15), 1.0, "arc", 90.0)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (SQUARE, "metres_per_pixel must be given"),
        ("metres_per_pixel = 0\n" + SQUARE, "metres_per_pixel must be a finite number above 0, got 0"),
        ('metres_per_pixel = "small"\n' + SQUARE, "metres_per_pixel must be a number, got 'small'"),
        ("metres_per_pixel = 0.1\nwalls = []\n", "walls must hold at least one wall"),
        (HUT + "colour = 1\n", "key must be one of .*, got 'colour'"),
        (HUT + 'doors = [{ at = [2, 0], hinch = "west", opens = "north" }]', "doors 1: key must be .*did you mean 'hinge'"),
        (HUT + 'doors = [{ at = [2, 0], kind = "trap" }]', "doors 1: kind must be one of arc, .*, got 'trap'"),
        (HUT + "doors = [{ at = [2, 0] }]", "doors 1: hinge and opens must be given"),
        (HUT + 'doors = [{ at = [2], hinge = "west", opens = "north" }]', r"doors 1: at must be a list of 2, got \[2\]"),
        (HUT + 'doors = [{ at = [2, 0], width = -1, kind = "opening" }]', "doors 1: width must be a finite number above 0"),
        (HUT + "windows = [{ at = [2, 0], casements = 1.5 }]", "windows 1: casements must be a whole number, got 1.5"),
        (HUT + "windows = [{ at = [2, 0], sill = 1 }]", "windows 1: sill must be true or false, got 1"),
        (HUT + "windows = [3]", "windows 1 must be a table"),
        (HUT + 'furniture = [{ kind = "beed", at = [1, 1] }]', "furniture 1: kind must be one of .*did you mean 'bed'"),
        (HUT + 'furniture = [{ kind = "bed" }]', "furniture 1: exactly one of at and against must be given"),
        (HUT + 'dimensions = [{ side = "south", points = [3, 1] }]', "dimensions 1: points must be at least two, rising"),
        (HUT + 'rooms = [{ name = "A", at = [1, 1] }, { name = "A", at = [2, 1] }]', "rooms 1: name must be different"),
        (HUT + 'start = "Hal"\nrooms = [{ name = "Hall", at = [1, 1] }]', "start must be one of Hall, got 'Hal'"),
        (
            'metres_per_pixel = 0.1\nwalls = [{ style = "outr", path = [[0, 0], [1, 0]] }]',
            "walls 1: style must be one of outer, inner, got 'outr'",
        ),
        (
            'metres_per_pixel = 0.1\nwalls = [{ style = "outer", path = [[1, 2], [1, 2]] }]',
            r"walls 1: a wall must have a length, got \[1.0, 2.0\] twice",
        ),
        (HUT + "[styles.outer]\nthickness = 0.01\n", "styles.outer: thickness must be at least a pixel, 0.1 m, got 0.01"),
        ('metres_per_pixel = 0.1\nwalls = [{ style = "outer" }]', "walls 1: exactly one of path and outline must be given"),
        ('metres_per_pixel = 0.1\nwalls = [{ style = "outer", path = [[1, 2]] }]', "walls 1: path needs at least 2 points"),
    ],
)
def test_parse_description_tells_mistakes(text, sentence):
    with pytest.raises(ValueError, match=sentence):
        parse_description(text)


@pytest.mark.parametrize(
    ("part", "sentence"),
    [
        ('doors = [{ at = [2, 1.5], hinge = "west", opens = "north" }]', r"doors 1: at must lie on a wall, got \[2.0, 1.5\]"),
        ("windows = [{ at = [2, 0], width = 5 }]", "windows 1: width must fit on its straight wall"),
        ("windows = [{ at = [0.5, 0], width = 1.2 }]", "windows 1: width must fit on its straight wall"),
    ],
)
def test_lay_out_tells_openings_beside_walls(part, sentence):
    with pytest.raises(ValueError, match=sentence):
        lay_out(parse_description(HUT + part))


def test_read_description_names_the_file(tmp_path):
    own = tmp_path / "shed.toml"
    own.write_text("metres_per_pixel = 0.1\nwalls = [", encoding="utf-8")
    with pytest.raises(ValueError, match=r"^shed.toml: "):
        read_description(own)
    with pytest.raises(FileNotFoundError, match="must be a TOML file, got .*none.toml, which does not exist"):
        read_description(tmp_path / "none.toml")
