line style: cylinder
initial line width: 0.5
surface: l leaf ovate
surface: k flower bilabiate
color: 1 78 128 60
color: 2 170 130 200
