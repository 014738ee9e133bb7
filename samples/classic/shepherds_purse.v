line style: cylinder
initial line width: 0.32
surface: l leaf lanceolate
surface: r leaf oblanceolate
surface: k flower cruciform
color: 1 86 130 58
color: 3 150 165 80
color: 2 250 250 244
