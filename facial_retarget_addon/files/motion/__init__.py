"""Motion files: FAP streams, ARKit recordings, optical markers."""
