"""Messages and reports of the node ``fusion``."""
