"""Writing the report of a run folder, and saying in a few lines what is in it."""
# ruff: noqa: PLC0415

from pathlib import Path

from rich.console import Console

from motionese.experiment.run_folder import run_settings


def report(folder: Path, console: Console) -> str:
    """Write the report; print where it is, and the results.

    Returns:
        Why there was too little for a statistical test, or "".

    Raises:
        RunFolderError: No run folder, or none of its runs has ended.
    """
    settings = run_settings(folder)
    # A second of imports that nobody who is told of a mistake should wait for.
    from motionese.analysis import write_report
    from motionese.interfaces.summary import summary

    with console.status("Writing the report …"):
        written = write_report(folder)
    console.print(summary(written.path.parent, settings["phases"]["change_after"]))
    console.print(f"Report: {written.path}")
    return str(written.too_few)
