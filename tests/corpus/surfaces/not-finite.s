0 1 0 1 0 1
a
TOP COLOR: 1e9 DIFFUSE: nan BOTTOM COLOR: 0 DIFFUSE: 0
AL: ~ A: ~ AR: ~
L: ~ R: ~
BL: ~ B: ~ BR: ~
inf 0 0 1 0 0 2 0 0 3 0 0
