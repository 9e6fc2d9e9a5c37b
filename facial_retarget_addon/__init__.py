"""Facial Retarget: the acting of one face on another face of any topology and proportions."""
