line style: cylinder
initial line width: 1.1
surface: l leaf ovate
color: 1 66 112 44
