"""Section of chapter 6: FastSLAM."""

from __future__ import annotations

from priorlab import plot
from priorlab.pipeline import SLAM_PRIOR, SLAM_THRESHOLD, Drive, PipelineResult
from priorlab.report.pictures import picture, size_for
from priorlab.report.section import Section, score_table
from priorlab.slam.trajectory_error import position_errors_m, true_poses


def drive_section(result: PipelineResult, drive: Drive) -> Section:
    """Chapter 6."""
    run, log = drive.run, drive.log
    ate = run.ate_m(log)
    size = size_for(result.drawing.shape)
    size = (size[0], size[1] + 0.4)
    pictures = (
        picture(
            lambda ax: plot.map(run.map, ax, trajectory=run.trajectory, truth=log.truth),
            f"The map of FastSLAM with the plan as prior, the true way dashed and the estimated way on it; error {ate:.2f} "
            f"metres.",
            "With the plan: map and way, estimated together.",
            size,
        ),
        picture(
            lambda ax: plot.map(drive.uninformed, ax, trajectory=run.trajectory),
            "The map of the same poses and scans without the plan: grey where the robot did not look.",
            "The same poses and scans, started from 0.5 everywhere.",
            size,
        ),
        picture(
            lambda ax: plot.trajectory_error(position_errors_m(run.trajectory, true_poses(log)), ax),
            f"The distance to the true position at each of {len(run)} steps; its root mean square is {ate:.2f} metres.",
            "How far the estimate was off.",
            (6.4, 3.0),
        ),
        picture(
            lambda ax: plot.particle_numbers(run.n_particles, run.ess, ax),
            f"The number of particles at each step, {run.n_particles.min()} to {run.n_particles.max()}.",
            "Particles that the KLD rule asked for, and how many of them count.",
            (6.4, 3.0),
        ),
    )
    where = (
        "its world holds furniture that the plan does not show"
        if result.plan is not None
        else "the building as extracted is the world"
    )
    how = (
        "localizes by the walls of the plan, and maps what it sees"
        if run.parameters.localize_in == "static"
        else "localizes in the map that it is making, and updates it"
    )
    text = (
        f"Now nobody tells the robot where it is. It drives {len(run)} steps ({where}), {how}. Prior: P(empty) "
        f"{SLAM_PRIOR.effective_p_wall:.2f} and {SLAM_PRIOR.effective_p_space:.2f}; cells of {run.map.grid.cell_size_m:.2f} m. "
        f"The absolute trajectory error (ATE) is {ate:.2f} m.",
    )
    warnings = (
        () if run.lost_because is None else (f"The robot got LOST: {run.lost_because}. No gain over another map means anything.",)
    )
    if drive.score_informed is None:
        return Section("FastSLAM: when the pose is not known", text, pictures, (), warnings)
    gain = drive.gain_percent
    said = (
        () if gain is None or run.lost else (f"With the plan F2 is {gain:+.0f} % against the map of the same poses without it.",)
    )
    alone = (
        "The plan alone is the third line, and here no map beats it: what the robot adds are changes and furniture, and "
        "those count as false positives."
        if drive.score_prior is not None and drive.score_prior.f_beta > drive.score_informed.f_beta
        else "The plan alone is the third line: what the robot adds are changes and furniture, and those count as false "
        "positives here.",
    )
    scores = {
        "the plan alone, no scan": drive.score_prior,
        "scans alone, no plan": drive.score_uninformed,
        "plan and scans": drive.score_informed,
    }
    caption = f"Detected as wall: P(empty) < {SLAM_THRESHOLD:g}, as chapter 6 has it"
    return Section(
        "FastSLAM: when the pose is not known", text + said + alone, pictures, (score_table(scores, caption),), warnings
    )
