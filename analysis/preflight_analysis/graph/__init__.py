"""Tree and interfaces to Graph: who talks to whom, with which type, under final names."""
