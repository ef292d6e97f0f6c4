"""Page of a running walk in the browser: what it shows, and the server that sends it."""
