"""What tests share: README.md says which to use when."""
