angle increment: 60
line style: cylinder
initial line width: 0.6
color: 40 40 90 150
