line style: cylinder
initial line width: 1
tropism: T: 0 -1 0 I: 1 E: 0.23
surface: l leaf lanceolate
color: 1 96 130 60
