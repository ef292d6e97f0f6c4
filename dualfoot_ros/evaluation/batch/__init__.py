"""Many walks and many methods: comparison, Monte Carlo, worker processes."""
