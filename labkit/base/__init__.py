"""The ground: command lines, words, git, child processes."""
