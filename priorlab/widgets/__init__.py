"""Sliders that wire the library to pictures; nothing is computed here."""
