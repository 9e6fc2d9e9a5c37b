"""Plays a scenario in a real Blender window, in a screen of its own that nobody sees.

    python tests/gui/window.py ROOT USER OUT SCENARIO [argument ...]

ROOT is what make_blender_root.sh has made, USER the user folder that has the extension installed, OUT the folder for
screenshots and what else the scenario writes. The status is 0 if the scenario ended well and nothing printed a
traceback.
"""

import os
import subprocess
import sys
from pathlib import Path
from subprocess import PIPE, STDOUT

HERE = Path(__file__).resolve().parent
REPOSITORY = HERE.parents[1]
ROOT = Path(os.environ.get("FACIAL_RETARGET_BLENDER_ROOT", REPOSITORY / "build" / "blender-root"))
"""Where make_blender_root.sh makes the folder with the real Blender."""
SIZE = (1280, 720)
LIMIT = 240
"""Seconds that a scenario may take."""


def lacks() -> str:
    """What playing in a window needs and does not find here; "" for nothing."""
    if os.geteuid():
        return "root rights"
    return "" if (ROOT / "usr" / "bin" / "blender").exists() else f"a Blender in {ROOT}, which make gui-test makes"


def install_as_shipped(root: Path, user: Path, out: Path) -> None:
    """Build the zip into a folder, and install it; see `install`."""
    subprocess.run([sys.executable, REPOSITORY / "build_extension.py", "--out", out], check=True)
    (archive,) = out.glob("*.zip")
    install(root, user, archive)


def install(root: Path, user: Path, archive: Path) -> None:
    """Install the extension from its zip into a user folder, and enable it; RuntimeError with what it said."""
    user.mkdir(parents=True, exist_ok=True)
    command = ["blender", "--command", "extension", "install-file", "-r", "user_default", "--enable", str(archive)]
    status, said = run(root, [user, archive.parent], user, command)
    if status or "Traceback" in said:
        raise RuntimeError(f"the zip could not be installed (status {status}):\n{said}")


def play(root: Path, user: Path, out: Path, scenario: Path, *arguments: str, limit: float = LIMIT) -> tuple[int, str]:
    """Play a scenario; returns its status, 0 if all went well, and everything that was printed.

    limit : seconds that it may take.
    """
    out.mkdir(parents=True, exist_ok=True)
    width, height = map(str, SIZE)
    screen = ["xvfb-run", "-a", "-s", f"-screen 0 {width}x{height}x24 +extension GLX -noreset -nolisten tcp"]
    blender = ["blender", "--enable-event-simulate", "-noaudio", "--window-geometry", "0", "0", width, height]
    # The exit code is for what the start script raises; drive.play ends Blender when a scenario does.
    blender += ["--python-exit-code", "3", "--python", str(HERE / "start.py")]
    blender += ["--", str(scenario), str(out), *arguments]
    folders = [user, out, REPOSITORY, scenario.parent]
    status, said = run(root, folders, user, [*screen, *blender], limit)
    if status == 0 and "Traceback (most recent call last)" in said:
        status = 4
    return status, said


def run(root: Path, folders: list[Path], user: Path, command: list[str], limit: float = LIMIT) -> tuple[int, str]:
    """Run a command inside the root, with some folders of this machine; returns its status and what it said."""
    variables = [f"BLENDER_USER_RESOURCES={user}", "PYTHONNOUSERSITE=1", "HOME=/tmp", "LANG=C.UTF-8"]
    variables += ["LIBGL_ALWAYS_SOFTWARE=1", "GALLIUM_DRIVER=llvmpipe"]
    whole = [HERE / "in_root.sh", root, *folders, "--", "env", *variables, *command]
    try:
        done = subprocess.run(
            whole, text=True, errors="replace", stdout=PIPE, stderr=STDOUT, timeout=limit, check=False
        )
    except subprocess.TimeoutExpired as late:
        said = (late.output or b"").decode("utf-8", "replace")
        return 124, f"{said}\nnot done after {limit} s\n"
    return done.returncode, done.stdout


if __name__ == "__main__":
    root, user, out, scenario = (Path(argument).resolve() for argument in sys.argv[1:5])
    status, said = play(root, user, out, scenario, *sys.argv[5:])
    print(said, end="")
    raise SystemExit(status)
