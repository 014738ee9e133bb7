line style: cylinder
initial line width: 0.5
color: 5 150 106 62
color: 6 176 134 88
