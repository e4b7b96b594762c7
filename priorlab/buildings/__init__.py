"""Buildings of our own: a readable description -> drawing, exact truth, world, survey, tour."""
