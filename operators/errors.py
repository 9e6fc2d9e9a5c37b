"""The one place where bad input becomes a message: a red report, and nothing is changed."""

from collections.abc import Callable
from functools import wraps
from typing import Any

from bpy.types import Operator

from ..facial_retarget_addon.core.errors import RetargetError

Method = Callable[..., set[str]]


def tells_user(method: Method) -> Method:
    """An operator's method, with RetargetError reported and the operator cancelled. Anything else is a bug."""

    @wraps(method)
    def guarded(self: Operator, *arguments: Any) -> set[str]:
        try:
            return method(self, *arguments)
        except RetargetError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

    return guarded
