"""A plain installation reads, trains, recognises and generates; what an extra brings is said."""

import subprocess
import sys

import pytest
from typed import refused

EXTRAS = (
    "pyarrow",
    "h5py",
    "mcap",
    "rosbags",
    "cv2",
    "sklearn",
    "onnx",
    "onnxruntime",
    "tensorboardX",
)
EXTRAS += ("rerun", "starlette", "uvicorn", "torch")
EXTRAS += ("dask", "distributed", "filelock", "jinja2", "mujoco", "pandas")
PLAINLY = """
import importlib.abc, sys

class Missing(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path, target=None):
        if name.partition(".")[0] in {blocked}:
            raise ModuleNotFoundError(f"No module named '{{name}}'", name=name)

sys.meta_path.insert(0, Missing())
from motionese.interfaces.commands.command_line import main
{first}
for line in {lines}:
    sys.argv = ["motionese", *line.split()]
    try:
        main()
    except SystemExit as left:
        if left.code:
            sys.exit(left.code)
print("all done")
"""
"""Run commands as if some packages were not installed."""


def run_without(blocked, lines, first=""):
    """Run lines of commands in a process of its own; returns status, output and errors."""
    program = PLAINLY.format(blocked=tuple(blocked), lines=list(lines), first=first)
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    return ran.returncode, ran.stdout, ran.stderr


def test_a_plain_installation_has_all_commands_for_csv_npz_and_eipl(arm):
    status, output, errors = run_without(
        EXTRAS,
        [
            "import demos.csv --out new.npz",
            "inspect new.npz",
            "measure demos.csv --against new.npz --plot measured.svg",
            "export new.npz --out eipl --to eipl",
            "import eipl --rate 20 --out again.csv",
        ],
        "import motionese, motionese.runtime\n"
        "from motionese.interfaces.commands import generate, outputs, recognise, train",
    )

    assert (status, errors) == (0, "")
    assert output.endswith("all done\n")


@pytest.mark.slow
def test_a_plain_installation_trains_recognises_and_generates(arm):
    status, output, errors = run_without(
        EXTRAS,
        [
            "train data.npz --out new.safetensors --levels 4:3,2:15 --epochs 1 --log jsonl",
            "recognise arm.safetensors demos.csv --observed x y --initial new.json",
            "generate arm.safetensors --initial new.json --like wave --out new.svg",
        ],
    )

    assert (status, errors) == (0, "")
    assert output.endswith("all done\n")


NEEDED = {
    "lerobot": ("export data.npz --out new --to lerobot", "pyarrow", "pyarrow"),
    "hdf5": ("export data.npz --out new.hdf5", "h5py", "h5py"),
    "read hdf5": ("import data.hdf5 --out new.npz", "h5py", "h5py"),
    "mcap": ("export data.npz --out new --to mcap", "mcap", "mcap"),
    "onnx": ("export arm.safetensors --onnx new.onnx", "onnx", "onnx"),
    "onnxruntime": ("export arm.safetensors --onnx new.onnx", "onnxruntime", "onnxruntime"),
    "tensorboard": (
        "train data.npz --out new.safetensors --log tensorboard",
        *("tensorboardX", "tensorboardX"),
    ),
    "rerun": ("train data.npz --out new.safetensors --log rerun", "rerun", "rerun-sdk"),
    "row by row": (
        "recognise arm.safetensors demos.csv --online --window 10 --log rerun",
        *("rerun", "rerun-sdk"),
    ),
    "measure": ("measure demos.csv", "scipy", "scipy"),
    "experiment": ("reproduce", "mujoco", "mujoco-core"),
    "many runs": ("reproduce", "dask", "dask"),
    "report": ("report runs/default", "pandas", "pandas"),
    "presets": ("presets", "mujoco", "mujoco-core"),
    "web": ("teach --no-browser", "mujoco", "mujoco-core"),
    "page": ("teach --no-browser", "starlette", "starlette"),
}
"""The command, the module that is not there, the package that would bring it."""
EXTRA = {"onnxruntime": "onnx", "read hdf5": "hdf5", "page": "web", "row by row": "rerun"}
EXTRA |= dict.fromkeys(("measure", "many runs", "report", "presets"), "experiment")


def run_here_without(module, line, monkeypatch):
    """Run a command in this process as if a module were not installed."""
    for name in [n for n in sys.modules if n.partition(".")[0] == module]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, module, None)
    return refused(*line.split())


@pytest.mark.parametrize("extra", NEEDED)
def test_a_missing_extra_is_told_by_a_sentence(arm, extra, monkeypatch):
    line, module, package = NEEDED[extra]
    told = run_here_without(module, line, monkeypatch)

    assert f"needs the package '{package}', which is not installed" in told
    assert told.endswith(f"pip install 'motionese[{EXTRA.get(extra, extra)}]'")


def test_a_simulated_robot_without_its_package_is_told_by_a_sentence_in_the_library_too():
    ran = subprocess.run(
        [sys.executable, "-c", "import sys; sys.modules['mujoco'] = None; import motionese.body"],
        capture_output=True,
        text=True,
    )

    assert ran.stderr.endswith(
        "MissingPackageError: a simulated robot needs the package 'mujoco-core', which is not "
        "installed: pip install 'motionese[experiment]'\n"
    )
