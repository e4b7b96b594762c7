"""Checks of the exercises, student copies."""
