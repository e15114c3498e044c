0 1 0 1 0 1
HEADING X: 1 Y: 1 Z: 1
UP X: -2 Y: -2 Z: -2
a
