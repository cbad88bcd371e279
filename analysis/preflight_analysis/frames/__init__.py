"""The coordinate frames of a launch: who broadcasts which, and who asks for which."""
