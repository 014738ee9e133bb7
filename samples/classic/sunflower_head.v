line style: cylinder
initial line width: 1.5
surface: s leaf cordate
color: 4 92 132 58
color: 5 128 116 48
color: 6 176 120 52
color: 7 150 92 36
color: 8 250 196 24
color: 9 112 82 44
