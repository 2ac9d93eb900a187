"""The command that writes a policy's folder: `lerobot-policy-motionese MODEL FOLDER`."""

from pathlib import Path
from typing import Annotated

import typer

from lerobot_policy_motionese.policy_folder import write
from motionese.errors import MotioneseError
from motionese.runtime import load


def command(
    model: Annotated[Path, typer.Argument(help="What `motionese train` wrote.")],
    folder: Annotated[Path, typer.Argument(help="A new folder, for --policy.path.")],
    dataset: Annotated[
        Path | None,
        typer.Option(help="A LeRobotDataset of the robot: the columns of its state and action."),
    ] = None,
) -> None:
    """Write the folder that lerobot-rollout and lerobot-eval take as --policy.path."""
    try:
        config, learned = write(model, folder, dataset), load(model)
    except MotioneseError as error:
        typer.echo(f"lerobot-policy-motionese: {error}", err=True)
        raise typer.Exit(2) from None
    typer.echo(f"Wrote {folder}.")
    typer.echo(f"observation.state: {', '.join(config.state_channels)}")
    typer.echo(f"action: {', '.join(config.action_channels)}")
    sensed = {*config.state_channels, *config.action_channels}
    if left := [name for name in learned.channels if name not in sensed]:
        typer.echo(f"Neither observed nor acted, but predicted: {', '.join(left)}")
    if left := [name for name in config.state_channels if name not in learned.channels]:
        typer.echo(f"Observed, but not known to the model and passed over: {', '.join(left)}")
    typer.echo(f"Motions, for --policy.motion or --task: {', '.join(learned.initial_states)}")
    if learned.rate_hz is not None:
        typer.echo(f"Run it at {learned.rate_hz:g} Hz, or tell --policy.rate_hz.")


def main() -> None:
    """Run the command."""
    typer.run(command)


if __name__ == "__main__":
    main()
