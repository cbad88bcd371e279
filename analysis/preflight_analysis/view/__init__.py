"""The graph as a picture: plain data, a layout, and the formats that it is drawn in."""
