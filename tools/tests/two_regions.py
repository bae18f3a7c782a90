"""A small part with two regions and seven markers."""

# Two boxes with a common facet. The seeds name one region; the other one is numbered.
PART = """12 3 0 0
1 0 0 0
2 1 0 0
3 2 0 0
4 2 1 0
5 1 1 0
6 0 1 0
7 0 0 1
8 1 0 1
9 2 0 1
10 2 1 1
11 1 1 1
12 0 1 1
11 1
4 1 2 5 6 1
4 2 3 4 5 1
4 7 8 11 12 2
4 8 9 10 11 2
4 1 2 8 7 3
4 2 3 9 8 3
4 5 6 12 11 4
4 4 5 11 10 4
4 1 6 12 7 5
4 3 4 10 9 6
4 2 5 11 8 7
0
1
1 0.5 0.5 0.5 20
"""
