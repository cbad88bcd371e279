"""What the user's nodes and launch files run with: distribution, package paths, interpreter, overlays."""
