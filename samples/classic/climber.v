line style: cylinder
initial line width: 1.4
surface: l leaf cordate
surface: k flower funnelform
color: 1 78 132 54
color: 2 120 90 200
color: 5 120 92 62
