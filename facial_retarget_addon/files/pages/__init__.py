"""Reports: figures as JSON, pages to look at, and their pictures."""
