"""What is known of a launch and its workspace: each question is answered here, once."""
