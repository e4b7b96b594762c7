"""Flats that came as centre lines, drawn in our styles and scored: other people's rooms, our own symbols."""
