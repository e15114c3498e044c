0 1 0 1 0 0
only
TOP COLOR: 3 DIFFUSE: 0 BOTTOM COLOR: 3 DIFFUSE: 0
AL: ~ A: ~ AR: ~
L: ~ R: ~
BL: ~ B: ~ BR: ~
0 0 0 1 0 0 2 0 0 3 0 0
0 1 0 1 1 0 2 1 0 3 1 0
0 2 0 1 2 0 2 2 0 3 2 0
0 3 0 1 3 0 2 3 0 3 3 0
