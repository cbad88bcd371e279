"""One file a rule. Adding one touches nothing else: `registry` finds them, the reference in docs/ is generated."""
