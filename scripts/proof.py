import kit

kit.run("proof")  # labkit/commands/proof.py
