line style: cylinder
initial line width: 0.26
surface: l leaf elliptic
surface: k flower campanulate
color: 1 104 150 74
color: 2 250 248 238
color: 3 64 124 52
color: 4 206 50 30
