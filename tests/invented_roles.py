"""Invented tables of what role each level plays, for the motions of a lesson."""

from itertools import permutations, product

import pandas as pd

from motionese.task import common_beginning

ALONE = {"first": (1.0, 0.0), "order": (0.0, 1.0)}
"""Cf the direction, Cs the order: shares of strokes that follow Cf and Cs."""
IN_CF = {"first": (1.0, 0.0), "order": (1.0, 0.0)}
IN_CS = {"first": (0.0, 0.75), "order": (0.0, 1.0)}
FOLLOWED = {"TD/MD": ALONE, "TD/MND": IN_CS, "TND/MD": IN_CF, "TND/MND": IN_CS}
RECOGNITIONS = ("least squares", "Adam", "Adam, cf slower")
DEMONSTRATIONS = (1, 2, 3)
ROWS = 14
"""Of a stroke."""


def branches(motion, lesson):
    """Strokes from 1 in which another motion of the lesson goes on otherwise."""
    common = [common_beginning(motion.name, o.name) for o in lesson if o is not motion]
    return {c for c in common if 1 < c <= len(motion.primitives)}


def exchanges_table(condition, seed, rng, lesson, shares):
    rows = []
    for recognition in RECOGNITIONS:
        for lower, upper in permutations(lesson, 2):
            stroke = common_beginning(lower.name, upper.name)
            kind = "first" if stroke == 1 else "order"
            for number in DEMONSTRATIONS if stroke else ():
                drawn, (cf, cs) = rng.random(), shares[kind]
                follows = "lower" if drawn < cf else "upper" if drawn < cf + cs else "neither"
                rows.append({
                    "condition": condition, "seed": seed, "recognition": recognition,
                    "motion_lower": lower.name, "motion_upper": upper.name,
                    "demonstration": number, "split": "cf", "kind": kind, "stroke": stroke,
                    "follows": follows,
                })  # fmt: skip
    return pd.DataFrame(rows)


def lesions_table(condition, seed, rng, lesson, shares):
    (first_cf, first_cs), (order_cf, order_cs) = shares["first"], shares["order"]
    lost = {
        "none": (0, 0),
        "cf_0 to its mean": (first_cf, order_cf),
        "cs_0 to its mean": (first_cs, order_cs),
        "cs → cf cut": (first_cs, order_cs),
    }
    rows = []
    for lesion, (first, order) in lost.items():
        for motion in lesson:
            for number in DEMONSTRATIONS:
                for stroke in range(1, len(motion.primitives) + 1):
                    ambiguous = stroke in branches(motion, lesson)
                    goes = first if stroke == 1 else order if ambiguous else 0
                    rows.append({
                        "condition": condition, "seed": seed, "motion": motion.name,
                        "demonstration": number, "lesion": lesion, "stroke": stroke,
                        "ambiguous": ambiguous, "right": bool(rng.random() < 1 - goes / 2),
                    })  # fmt: skip
    return pd.DataFrame(rows)


def decoding_table(condition, seed, rng, lesson, shares):
    who = {"condition": condition, "seed": seed}
    found = []
    for level, place in (("cf", 0), ("cs", 1)):
        score = 0.5 + 0.5 * shares["first"][place] - 0.02 * rng.random()
        for what, value, chance in (("direction", score, 0.25), ("position", 0.9, 0.0)):
            found.append({**who, "level": level, "what": what, "score": value, "chance": chance})
        if any(branches(motion, lesson) for motion in lesson):
            for row in range(-ROWS, ROWS):
                held = shares["order"][place] if row < 0 else 1.0
                score = 0.5 + 0.5 * held - 0.02 * rng.random()
                found.append({**who, "level": level, "what": "order", "score": score,
                              "chance": 0.5, "beginning": "LR ↑", "row": row})  # fmt: skip
    return pd.DataFrame(found)


def symbols_table(condition, seed, rng, lesson):
    rows = []
    for level, reference in product(("io", "cf", "cs"), ("alone", "taught")):
        for motion, number in product(lesson, DEMONSTRATIONS):
            signs = motion.name.partition(" ")[2]
            told = level == "io" or (
                condition == "TD/MD" and (level, reference) == ("cf", "taught")
            )
            wrong = not told and rng.random() < 0.4
            rows.append({
                "condition": condition, "seed": seed, "level": level, "reference": reference,
                "motion": motion.name, "demonstration": number,
                "read": signs + signs[0] if wrong else signs, "true": signs,
                "edit_distance": int(wrong),
                "boundary_error_steps": None if wrong else int(rng.integers(0, 4)),
            })  # fmt: skip
    return pd.DataFrame(rows)


def role_tables(condition, seed, rng, lesson, shares=None):
    """All four tables of a run, by file."""
    shares = FOLLOWED[condition] if shares is None else shares
    of = (condition, seed, rng, lesson)
    return {
        "exchanges.csv": exchanges_table(*of, shares),
        "lesions.csv": lesions_table(*of, shares),
        "decoding.csv": decoding_table(*of, shares),
        "symbols.csv": symbols_table(*of),
    }
