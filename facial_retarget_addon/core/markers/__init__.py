"""Optical markers: gaps, head motion, which point each one stands for, FAPs out of them."""
