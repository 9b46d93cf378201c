"""Set-up and the doctor."""
