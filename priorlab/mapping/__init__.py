"""Chapter 4's map: prior, evidence, update."""
