"""Speed and quality against peers, measured in one run: `python -m bench [section ...]`."""
