"""Where each place of one face lies on another: a dense correspondence between two surfaces."""
