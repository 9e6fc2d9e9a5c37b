"""Shape keys of one head onto others, with all that hangs on them."""
