line style: cylinder
initial line width: 1.6
surface: l leaf obovate
color: 1 74 122 50
