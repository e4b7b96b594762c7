"""The command line: `priorlab demo`, `run`, `localize`, `figures`, `student`, `buildings`.

Exit codes: 0 a whole result; 2 bad input, one sentence on stderr; 3 a result without walls; 4 walls, but the way ended early
(they do not close the building, or nobody knows the scale); 5 the robot of `localize` got lost; 130 stopped by Ctrl-C. With 3, 4
and 5 the results are written and say why.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import os
import shlex
import sys
import time
import traceback
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from priorlab.core.files import check_place

if TYPE_CHECKING:
    from priorlab.core.building import FloorPlan
    from priorlab.core.drawing import Drawing
    from priorlab.pipeline import PipelineResult

GOOD, BAD_INPUT, NO_WALLS, ENDED_EARLY, LOST, INTERRUPTED = 0, 2, 3, 4, 5, 130

DEMO_BUILDING = "office_floor"


class _Parser(argparse.ArgumentParser):
    """A parser whose complaint is one sentence."""

    def error(self, message: str) -> NoReturn:
        """Say it and leave with the code of bad input."""
        self.exit(BAD_INPUT, f"priorlab: {message}; see {self.prog} --help\n")


def main(argv: Sequence[str] | None = None) -> int:
    """Run a command; the exit code."""
    given = list(sys.argv[1:] if argv is None else argv)
    arguments = _parser().parse_args(given)
    arguments.command_line = shlex.join(["priorlab", *(Path(word).name if Path(word).is_absolute() else word for word in given)])
    try:
        return int(arguments.act(arguments))
    except KeyboardInterrupt:
        go_on = (
            "once the drive has begun, --resume goes on with it"
            if arguments.act is _localize
            else "nothing was left half written"
        )
        print(f"priorlab: interrupted; {go_on}", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:  # `priorlab buildings | head -1`: the reader has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return GOOD
    except (ValueError, OSError) as mistake:  # a sentence with name, rule and value
        if arguments.traceback:
            traceback.print_exc()
        print(f"priorlab: {_as_typed(' '.join(str(mistake).split()), arguments)}", file=sys.stderr)
        return BAD_INPUT


def _as_typed(sentence: str, arguments: argparse.Namespace) -> str:
    """The sentence with an option's name as one types it: `max_range_m` of the code is `--max-range` here."""
    name, _, rest = sentence.partition(" ")
    option = name.removesuffix("_m")
    return f"--{option.replace('_', '-')} {rest}" if option in vars(arguments) else sentence


def _seed(text: str) -> int:
    """A seed: a whole number of at least 0."""
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"seed must be a whole number of at least 0, got {text}")
    return int(text)


def _parser() -> argparse.ArgumentParser:
    """All commands and what they take."""
    parser = _Parser(
        prog="priorlab",
        description="What does a Bayesian prior do to a robot's map? Every probability is P(the cell is EMPTY).",
        epilog="Exit codes: 0 good, 2 bad input, 3 no walls found (the report says where they were lost), 4 walls, but the way "
        "ended early (the report says why), 5 the robot got lost (the numbers say where), 130 stopped by Ctrl-C.",
    )
    parser.add_argument("--version", action="version", version=f"priorlab {importlib.metadata.version('priorlab')}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=_Parser)

    demo = commands.add_parser("demo", help="one bundled floor plan all the way; leaves a report")
    demo.add_argument(
        "--building",
        default=DEMO_BUILDING,
        metavar="NAME",
        help="one of `priorlab buildings`, or your own NAME.toml (default %(default)s)",
    )
    _how_to_run(demo, out="out/demo", method="robust")
    demo.set_defaults(act=_demo)

    run = commands.add_parser("run", help="the same for a drawing of your own (PNG, JPEG, BMP, TIFF)")
    run.add_argument("drawing", metavar="DRAWING", help="image file")
    run.add_argument("--metres-per-pixel", type=float, metavar="X", help="scale; without it a door is taken as 0.85 m")
    _how_to_run(run, out=None, method="robust")
    run.set_defaults(act=_run)

    localize = commands.add_parser("localize", help="the log of your own robot (CARMEN) in the plan of its building")
    localize.add_argument("log", metavar="LOG", help="CARMEN log, plain or gzip")
    localize.add_argument("--map", required=True, metavar="FILE", help="the plan: a ROS map (its .yaml) or a drawing")
    localize.add_argument("--metres-per-pixel", type=float, metavar="X", help="scale of a drawing; a ROS map knows its own")
    localize.add_argument(
        "--start",
        nargs=3,
        type=float,
        required=True,
        metavar=("X", "Y", "DEGREES"),
        help="pose at the first scan in the map's frame, metres; of a drawing, from its lower left corner",
    )
    localize.add_argument(
        "--start-error", nargs=2, type=float, default=(0.0, 0.0), metavar=("M", "DEGREES"), help="how far it may be off (0 0)"
    )
    localize.add_argument(
        "--max-range", type=float, metavar="M", help="beams from here on do not count (the laser's, at most 20)"
    )
    localize.add_argument("--wheel-noise", type=float, metavar="A", help="all four alphas of algorithm 6.3 (default 0.01)")
    localize.add_argument(
        "--temper", type=float, metavar="T", help="how much a scan counts, up to 1 (default 0.05; 0.2 where scans lie far apart)"
    )
    localize.add_argument(
        "--map-mode",
        choices=("trinary", "scale", "raw"),
        default="trinary",
        help="of the ROS map that is written (%(default)s): trinary is sure or unknown, scale and raw keep every percent",
    )
    localize.add_argument("--resume", action="store_true", help="go on with a drive that was interrupted")
    _where(localize, out="out/localize")
    localize.set_defaults(act=_localize, seed=None)  # with --resume, none is the one that the drive began with

    figures = commands.add_parser("figures", help="a figure or table of the thesis anew: ours, with numbers and a verdict")
    figures.add_argument("name", nargs="?", metavar="NAME", help="as --list has it; 'all' makes every one")
    figures.add_argument("--list", action="store_true", help="list the names and leave")
    _where(figures, out="out/figures")
    figures.set_defaults(act=_figures)

    student = commands.add_parser("student", help="copies of the notebooks without the solutions")
    student.add_argument("out", metavar="OUT", help="folder for the copies")
    student.add_argument("--notebooks", default="notebooks", metavar="DIR", help="the teacher's notebooks (default %(default)s)")
    student.add_argument("--seed", type=_seed, default=0, help="the student's own numbers (default %(default)s)")
    student.add_argument("--force", action="store_true", help="replace what priorlab made there")
    student.set_defaults(act=_student)

    buildings = commands.add_parser("buildings", help="list the bundled buildings")
    buildings.set_defaults(act=_buildings)
    for command in (demo, run, localize, figures, student, buildings):
        command.add_argument("--traceback", action="store_true", help="show where in the code a complaint comes from")
    return parser


def _where(command: argparse.ArgumentParser, out: str | None) -> None:
    """Where the results go."""
    words = "folder for the results" + (" (default %(default)s)" if out else "")
    command.add_argument("--out", default=out, required=out is None, metavar="DIR", help=words)
    command.add_argument("--force", action="store_true", help="replace what priorlab made there")
    command.add_argument("--seed", type=_seed, default=0, help="of everything random (default 0)")


def _how_to_run(command: argparse.ArgumentParser, out: str | None, method: str) -> None:
    """What `demo` and `run` share."""
    _where(command, out)
    command.add_argument("--method", choices=("robust", "thesis"), default=method, help="of chapter 3 (default %(default)s)")
    command.add_argument("--p-wall", type=float, default=0.2, metavar="P", help="P(empty) where the drawing shows a wall (0.2)")
    command.add_argument("--p-space", type=float, default=0.9, metavar="P", help="P(empty) where it shows space (0.9)")
    command.add_argument("--cell-size", type=float, default=3, metavar="PX", help="side of a cell in pixels (3)")


def _demo(arguments: argparse.Namespace) -> int:
    """One of our buildings."""
    check_place(arguments.out, arguments.force)
    from priorlab.buildings.floor_plans import load_floor_plan

    plan = load_floor_plan(arguments.building)
    return _go(arguments, plan.drawing, plan)


def _run(arguments: argparse.Namespace) -> int:
    """The user's own drawing."""
    check_place(arguments.out, arguments.force, keep=[arguments.drawing])
    from priorlab.interchange.images import read_drawing

    return _go(arguments, read_drawing(arguments.drawing, arguments.metres_per_pixel), None)


def _go(arguments: argparse.Namespace, drawing: Drawing, plan: FloorPlan | None) -> int:
    """Run the pipeline, write the folder, print the numbers that matter."""
    from priorlab.core.grid_map import Prior
    from priorlab.drawing.method import ROBUST, THESIS
    from priorlab.pipeline import run_pipeline
    from priorlab.report.folder import write_results

    prior = Prior(arguments.p_wall, arguments.p_space)
    tell = _Clock()
    reduced = f", reduced by {drawing.reduced_by:.2f}" if drawing.reduced_by > 1 else ""
    print(f"{drawing.name}: {drawing.shape[1]} x {drawing.shape[0]} pixels{reduced}")
    result = run_pipeline(
        drawing,
        plan,
        seed=arguments.seed,
        prior=prior,
        method=THESIS if arguments.method == "thesis" else ROBUST,
        cell_size=arguments.cell_size,
        progress=tell,
    )
    tell("report")
    write_results(result, arguments.out, arguments.command_line, arguments.force)
    tell("done")
    print()
    for name, value in summary(result):
        print(f"  {name:<34}{value}")
    print(f"\n  open {Path(arguments.out) / 'report.html'}")
    return exit_code(result)


def _localize(arguments: argparse.Namespace) -> int:
    """FastSLAM on a robot's own log."""
    check_place(arguments.out, arguments.force, keep=[arguments.log, arguments.map])
    import math

    from priorlab.report.own_log import WHEEL_NOISE, advice, drive_own_log, read_own_log, told_of_walls
    from priorlab.report.own_log_files import write_own_log
    from priorlab.report.own_log_verdict import judge
    from priorlab.slam.parameters import TUNED

    tell = _Clock()
    tell("the log and the map")
    x, y, degrees = arguments.start
    noise = WHEEL_NOISE if arguments.wheel_noise is None else arguments.wheel_noise
    temper = TUNED.temper if arguments.temper is None else arguments.temper
    start, off = (x, y, math.radians(degrees)), (arguments.start_error[0], math.radians(arguments.start_error[1]))
    own = read_own_log(arguments.log, arguments.map, start, arguments.metres_per_pixel, arguments.max_range, noise, off, temper)
    out = Path(arguments.out)
    out.absolute().parent.mkdir(parents=True, exist_ok=True)
    part = out.with_name(f"{out.name}.part")

    def begins() -> None:
        for sentence in (told_of_walls(own), advice(own)):
            print(*([f"  {sentence}\n"] if sentence else []), end="")
        tell(f"FastSLAM on {len(own.log)} scans; Ctrl-C stops it, --resume goes on")

    with warnings.catch_warnings():
        warnings.simplefilter("always", UserWarning)
        warnings.showwarning = lambda message, *_: print(f"  {message}")
        run = drive_own_log(own, part, arguments.seed, arguments.resume, arguments.force, _Steps(), begins)
    tell("results")
    verdict = judge(run, own)
    notes = write_own_log(run, own, verdict, out, arguments.command_line, arguments.force, arguments.map_mode)
    part.unlink()
    lost = f"LOST ({verdict.lost}), " if verdict.lost and not run.lost else ""  # a lost run says so itself
    print(f"\n  {lost}{run.summary(log=verdict.corrected)}")
    for note in notes:
        print(f"  {note}")
    more = "".join(f"{name}, " for name in ("corrected.tum", "walls.png") if (out / name).exists())
    print(f"\n  {out / 'map.png'}, map.yaml, trajectory.tum, {more}run.npz, numbers.json")
    return LOST if verdict.lost else GOOD


class _Steps:
    """How far a drive is: a line that rewrites itself in a terminal, a line every tenth elsewhere."""

    def __init__(self) -> None:
        self.start, self.first, self.shown = time.perf_counter(), 0, 0

    def __call__(self, done: int, to_do: int) -> None:
        self.first = self.first or done  # a drive that is gone on with does not begin at 0
        alive = sys.stdout.isatty()
        part = int((100 if alive else 10) * done / to_do)
        if part == self.shown:
            return
        self.shown = part
        left = (time.perf_counter() - self.start) * (to_do - done) / max(done - self.first, 1)
        sentence = f"  step {done} of {to_do}, about {left:.0f} s to go"
        print(f"\r{sentence:<60}" if alive else sentence, end="\n" if not alive or done == to_do else "", flush=True)


class _Clock:
    """Prints what is being done and how long it has been going on."""

    def __init__(self) -> None:
        self.start = time.perf_counter()

    def __call__(self, sentence: str) -> None:
        print(f"[{time.perf_counter() - self.start:5.1f} s] {sentence}", flush=True)


def exit_code(result: PipelineResult) -> int:
    """0, or why the way ended early."""
    if not result.has_walls:
        return NO_WALLS
    return ENDED_EARLY if result.stopped else GOOD


def summary(result: PipelineResult) -> list[tuple[str, str]]:
    """The numbers that matter, as rows of a small table."""
    rows = [
        ("scale", result.scale.sentence),
        ("corners, doors", f"{len(result.extraction.corners)}, {len(result.extraction.doors)}"),
    ]
    score, mapping, search, drive = result.walls_score, result.mapping, result.search, result.drive
    if score is not None:
        rows.append(("walls: precision, recall", f"{score.precision:.3f}, {score.recall:.3f}"))
    else:
        rows.append(("walls", f"{100 * result.walls.mask.mean():.1f} % of the pixels; no truth is known, so no score"))
    if not result.has_walls or not result.extraction.doors:
        rows += [(f"  after {name}", f"{count} left") for name, count in result.extraction.funnel.items()]
    if result.share_indoors is not None:
        rows.append(
            (
                "closed rooms",
                f"{100 * result.share_indoors:.0f} % of the space within the walls' outline; the rest is not explored",
            )
        )
    if mapping is not None:
        rows.append(("survey", f"{len(mapping.readings)} poses, {mapping.evidence.mean_looks:.2f} looks at a seen cell"))
        if mapping.score_prior and mapping.score_uninformed and mapping.score_informed:
            three = (mapping.score_prior, mapping.score_uninformed, mapping.score_informed)
            rows.append(("map F2: plan, readings, both", ", ".join(f"{one.f_beta:.3f}" for one in three)))
    if search is not None:
        best = search.sweep.best("f_beta")
        rows.append(("best F2 of all priors", f"{best.value:.3f}" + (f" at {best.plateaus[0]}" if best.plateaus else "")))
        rows.append(
            ("Pareto front: exact, NSGA-II", f"hypervolume {search.exact.hypervolume:.4f}, {search.searched.hypervolume:.4f}")
        )
    if drive is not None:
        lost = f"; LOST: {drive.run.lost_because}" if drive.run.lost else ""
        rows.append(("FastSLAM error (ATE)", f"{drive.run.ate_m(drive.log):.2f} m over {len(drive.run)} steps{lost}"))
        if drive.score_prior and drive.score_uninformed and drive.score_informed:
            three = (drive.score_prior, drive.score_uninformed, drive.score_informed)
            rows.append(("FastSLAM F2: plan, scans, both", ", ".join(f"{one.f_beta:.3f}" for one in three)))
    if result.stopped:
        rows.append(("ended early", result.stopped))
    return rows


def _figures(arguments: argparse.Namespace) -> int:
    """Figures of the thesis."""
    from priorlab.figures.registry import FIGURES, NOT_COMPUTABLE, figure_named
    from priorlab.figures.writing import write_figures

    if arguments.list or not arguments.name:
        width = max(map(len, [*FIGURES, *NOT_COMPUTABLE])) + 2
        for name, entry in FIGURES.items():
            print(f"{name:<{width}}{entry.title}")
        for name, shows in NOT_COMPUTABLE.items():
            print(f"{name:<{width}}cannot be computed: {shows}")
        return GOOD
    chosen = list(FIGURES.values()) if arguments.name == "all" else [figure_named(arguments.name)]
    for line in write_figures(chosen, arguments.out, arguments.seed, arguments.force):
        print(line, flush=True)
    return GOOD


def _student(arguments: argparse.Namespace) -> int:
    """The students' copies."""
    from priorlab.course.student import student_copy

    for path in student_copy(arguments.notebooks, arguments.out, arguments.force, arguments.seed):
        print(path)
    return GOOD


def _buildings(arguments: argparse.Namespace) -> int:
    """The bundled buildings, a line each."""
    from priorlab.buildings.floor_plans import floor_plan_names, load_floor_plan

    for name in floor_plan_names():
        print(load_floor_plan(name))
    return GOOD


if __name__ == "__main__":
    sys.exit(main())
