"""The exceptions that a user may meet."""


class RetargetError(Exception):
    """Bad input. The text is what the user reads: what arrived, what was wanted, where.

    One sentence, no traceback: the command line prints it and exits with status 2, an operator
    reports it and cancels. Anything else that is raised is a bug and keeps its traceback.
    """


class Cancelled(Exception):
    """The user asked to stop (Esc, Ctrl-C). Nothing has been written."""
