"""Chapter 3: what does a drawing say? Ink, corners, doors, walls, and the simple filters to hold them against.

Everything here is in pixels of the image: x to the right, y DOWN. Results are in the pixels of the drawing that came in.
"""
