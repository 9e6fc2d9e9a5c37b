"""Feature points on objects: kept, put back, proposed, copied; the base mesh over them."""
