"""The process that a command has for itself: how it is interrupted, what memory it keeps."""
