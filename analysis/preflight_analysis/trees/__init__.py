"""Behaviour trees of BehaviorTree.CPP, and the nodes that Nav2 has for them."""
