"""Fixtures that every room's tests share."""

import os
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).resolve().parent.parent


@pytest.fixture(scope="session")
def shared_data() -> Path:
    """Folder of real faces beside the project; the test is skipped where it is absent."""
    folder = Path(os.environ.get("FACIAL_RETARGET_DATA", REPOSITORY.parent / "shared" / "data"))
    if not (folder / "ict_dev.npz").exists():
        if os.environ.get("CI"):
            pytest.fail(f"the real faces are not in {folder}: CI always runs their tests")
        pytest.skip("the real faces beside the project are not here")
    return folder
