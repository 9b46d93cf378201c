"""robo47: derive it by hand, verify it against MuJoCo, record the number."""
