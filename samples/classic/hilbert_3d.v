angle increment: 90
line style: cylinder
initial line width: 0.42
color increment: 1
initial color: 0
