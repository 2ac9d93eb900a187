"""Small run folders made of invented tables, without any network or robot."""

import json

import numpy as np
import pandas as pd
from invented_roles import role_tables

from motionese.experiment import condition_named, read_settings
from motionese.experiment.digests import DIGESTS, list_files
from motionese.task import PUSHING_BUTTONS

STUDY = read_settings()
CONDITIONS = STUDY.conditions
NEW_MOTIONS = PUSHING_BUTTONS.lesson("triples")


def condition(name):
    return condition_named(name, STUDY.factors)


def write_settings(root, study=STUDY, **facts):
    """Write the settings of a run folder."""
    settings = study.model_dump(mode="json")
    facts = {"format": "motionese-run", "version": 5, "settings": settings} | facts
    (root / "settings.json").write_text(json.dumps(facts))
    list_anew(root)


def list_anew(folder):
    """List the digests of all files of a folder, as if each was written as it is now."""
    (folder / DIGESTS).unlink(missing_ok=True)
    list_files(folder, [path.name for path in folder.iterdir() if path.is_file()])


LOOPS, CHANGE = 8, 4
ERRORS = {"TD/MD": 1.0, "TD/MND": 2.0, "TND/MD": 6.0, "TND/MND": 1.5}
"""Error [cm] at the end of a phase and on triples: the paper's claims (a) and (b)."""
TURN = {"TD/MD": 0.1, "TD/MND": 4.0, "TND/MD": 4.0, "TND/MND": 4.0}
"""How far directions turn over the map [rad]: the paper's claim (c)."""


def loops_table(condition, seed, rng, error, loops=LOOPS):
    rows = []
    for loop in range(1, loops + 1):
        phase = 1 if loop <= CHANGE else 2
        for motion in PUSHING_BUTTONS.sequences(phase):
            base = error + 15 * np.exp(-loop) + 0.1 * rng.random()
            rows.append({
                "condition": condition, "seed": seed, "loop": loop, "phase": phase,
                "motion": motion.name, "imitation_error_cm": base,
                "recognition_residual_cm": 0.3 * base, "model_error_cm": 0.5 * base,
                "buttons_due": 1, "buttons_pressed": int(loop > 2), "press_depth_mm": 2.0 * loop,
                "press_depths_mm": " ".join([str(2.0 * loop)] * min(2, loop)),
                "reproduction_error_cm": 0.2 * base,
                "reproduction_strokes_cm": " ".join([f"{0.2 * base:.2f}"] * phase),
                "status": "recognised", "seconds": 0.1,
            })  # fmt: skip
    return pd.DataFrame(rows)


def triples_table(condition, seed, rng, error):
    rows = []
    for i, motion in enumerate(NEW_MOTIONS):
        trained = PUSHING_BUTTONS.is_taught(motion)
        base = error * (1 if trained else 1.5) + error * 0.1 * i + 0.05 * rng.random()
        rows.append({
            "condition": condition, "seed": seed, "motion": motion.name, "trained": trained,
            "imitation_error_cm": base, "recognition_residual_cm": base / 2,
            "model_error_cm": base / 2, "buttons_due": 1, "buttons_pressed": 1,
            "press_depth_mm": 9.0, "status": "recognised",
            "repertoire_imitation_error_cm": 1.5 * base,
            "repertoire_recognition_residual_cm": base, "repertoire_status": "recognised",
        })  # fmt: skip
    return pd.DataFrame(rows)


def online_table(condition, seed, rng, error):
    rows = []
    for taught, sequences in ((True, PUSHING_BUTTONS.sequences(2)), (False, NEW_MOTIONS)):
        for motion in sequences:
            for lag in range(5):
                rows.append({
                    "condition": condition, "seed": seed, "taught": taught, "motion": motion.name,
                    "lag": lag, "imitation_error_cm": error + 2.0 / (1 + lag) + 0.1 * rng.random(),
                    "after_the_fact_error_cm": error,
                })  # fmt: skip
    return pd.DataFrame(rows)


def switches_table(condition, seed):
    first, second = (each.name for each in PUSHING_BUTTONS.sequences(2)[:2])
    turns = [(7, 3.0), (18, np.nan)]
    return pd.DataFrame([
        {"condition": condition, "seed": seed, "first": first, "second": second, "row": row,
         "steps": steps}
        for row, steps in turns
    ])  # fmt: skip


def map_table(condition, seed, rng, turn, points=4):
    """Directions of the primitives, turned by `turn` from one side of the map to the other."""
    rows = []
    side = np.linspace(-5, 5, points)
    true = {"↓": -1.5, "↑": 1.5, "←": 3.1}
    for motion in PUSHING_BUTTONS.sequences(1):
        for x in side:
            for y in side:
                angle = true[motion.name[-1]] + turn * x / 10 + 0.01 * rng.standard_normal()
                rows.append({
                    "condition": condition, "seed": seed, "primitive": motion.name,
                    "cs_1": x, "cs_2": y, "direction_1_rad": angle, "extent_1_rad": 0.3,
                    "direction_2_rad": angle + y * turn / 10, "extent_2_rad": 0.2,
                })  # fmt: skip
    return pd.DataFrame(rows)


def development_table(condition, seed, opens, loops=LOOPS):
    rows = []
    for loop in range(1, loops + 1):
        rms = 2.0 + 0.1 * loop if loop >= opens else np.nan
        rows.append({
            "condition": condition, "seed": seed, "loop": loop, "levels": 3, "loss": 1.0,
            "rms_cs_to_cf": rms, "rms_cs_to_cf_at_opening": 2.0 if loop >= opens else np.nan,
        })  # fmt: skip
    return pd.DataFrame(rows)


def belief_arrays(steps):
    """What a robot believes of a demonstration that turns in row 7, and is noticed 3 rows later."""
    first, second, other = (each.name for each in PUSHING_BUTTONS.sequences(2)[:3])
    late = (np.arange(steps) > 9).astype(float)
    beliefs = {first: 0.9 * (1 - late), second: 0.9 * late, other: 0.05, "none of these": 0.05}
    arrays = {f"belief.{name}": belief + 0 * late for name, belief in beliefs.items()}
    return arrays | {"switch": np.array([7.0, 3.0])}


def inside_arrays(rng, steps=42):
    t = np.linspace(0, 1, steps)
    arrays = {}
    for motion in NEW_MOTIONS:
        path = np.stack([0.5 + 0 * t, -0.3 + 0.2 * t, 1.05 - 0.2 * np.sin(3 * t) ** 2], axis=1)
        arrays[f"shown.{motion.name}"] = path
        arrays[f"performed.{motion.name}"] = path + 0.01 * rng.standard_normal((steps, 3))
    return arrays | {
        "activity": rng.random((steps, 48)).astype(np.float32),
        "commanded": np.zeros((steps, 2)),
        "sensed": np.stack([0.1 + 0.4 * np.sin(3 * t), -0.2 + 0 * t], axis=1),
        "begins": np.array([0, 14, 28]),
        "effect.right_button": np.where(abs(t - 0.3) < 0.05, 9.0, 0.0),
        "effect.left_button": 0 * t,
        **belief_arrays(steps),
        "poses": np.tile([0, 0.4, 0.1, -0.2, 0, 0, 1.3, 1.1, 0.95], (steps, 1)),
    }


def write_run(root, condition, seed, *, end="finished", error=None, turn=None, study=STUDY):
    """Write a run's folder; `end` is how it ended, "unfinished" or "diverged" included."""
    folder = root / condition.folder / f"seed-{seed}"
    folder.mkdir(parents=True)
    if not (root / "settings.json").exists():
        write_settings(root, study)
    rng = np.random.default_rng([seed, CONDITIONS.index(condition)])
    name = condition.name
    loops = 2 if end != "finished" else LOOPS
    for loop in range(1, loops + 1):
        (folder / f"loop-{loop:02d}.safetensors").touch()
    if end == "unfinished":
        list_anew(folder)
        return folder
    error = ERRORS[name] if error is None else error
    opens = 1 if "MND" in condition.choices else CHANGE + 1
    tables = {
        "loops.csv": loops_table(name, seed, rng, error, loops),
        "development.csv": development_table(name, seed, opens, loops),
    }
    if end == "finished":
        tables["triples.csv"] = triples_table(name, seed, rng, error)
        tables["online.csv"] = online_table(name, seed, rng, error)
        tables["switches.csv"] = switches_table(name, seed)
        tables["slow_state_map.csv"] = map_table(
            name, seed, rng, TURN[name] if turn is None else turn
        )
        tables |= role_tables(name, seed, rng, study.development(condition)[-1].lesson)
        np.savez_compressed(folder / "inside.npz", **inside_arrays(rng))
    for file, table in tables.items():
        table.to_csv(folder / file, index=False)
    reason = "" if end == "finished" else "loop 2: diverged at epoch 3"
    ended = {"status": end, "reason": reason, "seconds": 12.5}
    (folder / "ended.json").write_text(json.dumps(ended))
    list_anew(folder)
    return folder


def without_map(folder):
    """Leave a run as one of a network without a slow level."""
    (folder / "slow_state_map.csv").write_text("\n")
    list_anew(folder)


def without_stage_2(folder):
    """Leave a run as one of settings whose stage 1 is all."""
    loops = pd.read_csv(folder / "loops.csv")
    loops[loops["phase"] == 1].to_csv(folder / "loops.csv", index=False)
    development = pd.read_csv(folder / "development.csv")
    development[development["loop"] <= CHANGE].to_csv(folder / "development.csv", index=False)
    list_anew(folder)
