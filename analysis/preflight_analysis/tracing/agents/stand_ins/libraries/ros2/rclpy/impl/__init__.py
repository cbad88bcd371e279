"""What is made of C."""
