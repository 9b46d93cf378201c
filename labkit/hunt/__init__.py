"""Bug hunts: a right lab with one mistake of the catalogue put in, to be found.

    quarry    which mistakes can be hunted, and which one a seed draws
    script    the hunted script: a lab, or a week's capstone, whose functions are closed
    hunted    what a closed function does when it is called
    case      a hunt as it stands: what was suspected, run and repaired
    verdict   is it the function, and does the repair pass?

No file says what the mistake is: day, level and seed do, with this kit.
"""
