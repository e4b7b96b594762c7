"""Many drawings, priors and seeds."""
