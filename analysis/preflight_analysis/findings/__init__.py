"""What is reported: findings, their suppression, and the forms in which they are printed."""
