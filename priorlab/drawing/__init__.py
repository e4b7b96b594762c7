"""Chapter 3: an image of a drawing -> corners -> doors -> walls."""
