"""A robot in a known building: rays, range sensor, inverse sensor model, odometry, route planner."""
