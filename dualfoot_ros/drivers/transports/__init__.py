"""Where bytes come from: serial ports, UDP, TCP, Bluetooth, files."""
