line style: cylinder
initial line width: 0.26
surface: l leaf elliptic
color: 1 84 140 56
