line style: cylinder
initial line width: 0.5
surface: l leaf lanceolate
color: 1 92 140 52
