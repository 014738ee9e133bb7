angle increment: 22.5
line style: cylinder
initial line width: 0.24
color: 1 80 120 60
