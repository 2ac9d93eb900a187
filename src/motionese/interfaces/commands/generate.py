"""A model and initial states in, a motion out: as a recording or a picture."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from rich.console import Console

from motionese.channels import Channels
from motionese.errors import HELD_OUT, NO_MOTION, SettingError, unknown
from motionese.interfaces.commands.initial_states import read_initial_states
from motionese.interfaces.commands.motion_figure import write_figure
from motionese.interfaces.commands.outputs import PICTURES, RECORDINGS, check_apart, check_output
from motionese.interfaces.commands.summaries import reach
from motionese.learning import Motions, generate_sequence, load


def generate_motion(
    console: Console,
    model: Path,
    *,
    like: Sequence[str],
    initial: Path | None,
    steps: int | None,
    duration: float,
    start: Mapping[str, float],
    blend: int | None,
    out: Path,
) -> None:
    """Generate one motion, or several in sequence; write it as `out`'s suffix has it.

    Args:
        like: Names of learned motions; or, with `initial`, of motions in that file.
        initial: A file of initial states, as `recognise` writes them.
        steps: Rows of every motion; as many as it had, times the duration, for None.
        duration: How many times as long the motions last.
        start: Where the robot is, by channel, in the channels' units.
        blend: Rows of a transition between motions; found for None.
    """
    check_output("--out", out, (*RECORDINGS, *PICTURES))
    check_apart([model, *([initial] if initial else [])], out)
    fit = load(model)
    assert fit.network.channels is not None, "a trained network carries channels"
    # Refuses a scale before rows are counted with it.
    fit.network.lasting(duration)
    known = (
        {n: (u, t) for n, u, t in zip(fit.names, fit.initial_states, fit.lengths, strict=True)}
        if initial is None
        else read_initial_states(initial, fit.network)
    )
    if not known:
        raise SettingError(f"{model}: {NO_MOTION}")
    if not like and initial is None:
        raise SettingError(
            f"say what to generate: --like EPISODE, one of {', '.join(known)}; or --initial FILE"
        )
    for name in like:
        if initial is None and name in fit.validation_names:
            raise SettingError(f"--like {name}: motion '{name}' {HELD_OUT}")
        if name not in known:
            raise SettingError(f"--like {name}: {unknown('motion', name, known)}")
    taken = list(like) or list(known)
    names = " + ".join(taken)
    states = [known[name][0] for name in taken]
    rows = [steps or max(round((known[name][1] - 1) * duration) + 1, 2) for name in taken]
    if start:
        _check_start(fit.network.channels, start)
    path = generate_sequence(
        fit.network, states, rows, blend=blend, duration=duration, here=start or None
    )
    motion = Motions.from_arrays([path], fit.network.channels, fit.rate_hz, names=[names])
    if out.suffix.lower() in PICTURES:
        labels = [(c.name, c.unit) for c in fit.network.channels]
        write_figure(out, [path], [names], labels, fit.rate_hz, f"{model.name}: {names}")
    else:
        motion.write(out)
    speeds = np.abs(np.diff(path, axis=0)).max(0) * fit.rate_hz
    fastest = int((speeds / fit.network.channels.spans).argmax())
    channel = fit.network.channels[fastest]
    console.print(
        f"{out}: {names}, {len(path)} rows, {(len(path) - 1) / fit.rate_hz:.2f} s; fastest in its "
        f"range is {channel.name} with {speeds[fastest]:.3g} {channel.unit or 'units'}/s"
    )


def _check_start(channels: Channels, start: Mapping[str, float]) -> None:
    """Refuse a start, perhaps in another unit, that the network cannot take up."""
    for channel, lowest, highest in zip(channels, *reach(channels), strict=True):
        value = start.get(channel.name, lowest)
        if value < lowest or value > highest:
            raise SettingError(
                f"--start {channel.name}={value:g}: where the robot is must lie within the model's "
                f"reach, {lowest:.4g} to {highest:.4g}{f' {channel.unit}' * bool(channel.unit)}"
            )
