line style: cylinder
initial line width: 0.12
surface: l leaf elliptic
color: 1 70 120 45
