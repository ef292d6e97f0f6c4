"""Updates that take some states as known: a Schmidt-Kalman filter of a special kind."""
