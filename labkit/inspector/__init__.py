"""The inspector: the arm, its frames, the student's own code, in a browser.

    make view DAY=2

The page belongs to no day. A day declares its tabs in `dayN/inspector.py`:
docs/authors.md has an example, and `declared.py` says what is called when. The first of
TABS is open at the start; Joints, Chain and Tasks, which every day has, follow where
they are not in it. A day may also name the function that draws the student's arm:

    GHOST = Ghost("fk_space", FRAMES, ask)

`GHOST.questions(model, q)` returns the arguments for each frame in `GHOST.frames`, such
as `fk_space(screws[:k], M_k, q[:k])`. Where there is no GHOST, no ghost arm is drawn;
the file is watched all the same.

What a tab has in `page` (`labkit/inspector/page.py` says the arguments):

    model, arm, q, pose(name)   the robot, its numbers, the configuration, MuJoCo's pose
    move(q)                     moves the arm, in every browser
    own(library, units=...)     the student's functions, in the sandbox; a line says how
                                they compare with the library's of the same names
    job(work, done)             work that waits for them, on another thread
    animate(step, hz, work)     a loop in real time: start(), stop(), toggle()
    draw                        arrows, lines, curve, sphere, ellipsoid, frame, label,
                                ghost (a second arm), robot (a scene of MuJoCo's),
                                target (a pose to drag)
    slider, buttons, choice, tick    viser's own, each with a callback
    html, say, matrix, legend   text, a line, a pose, what the colours mean
    bars, plot                  numbers per joint against limits; curves over time
    image                       what a camera sees, in colours or in depths
    light(chosen, shown)        which frames are drawn, and which one stands out
    hide_arm()                  no arm but the tab's own
    gui, scene                  viser's own, for what is missing here

Everything a tab makes vanishes when the tab is left: its widgets, its drawings, its
loops. At a save all that was said turns grey until the new file has answered. What a
tab shows and a task of the day computes is asked of `own`: a test changes a sign in
each of a tab's `functions`. What is wanted at one moment needs two
queues (`page.jobs_apart()`): of those that wait in `job` the newest is done.

Callbacks run one after the other on the server's event loop: keep them under 20 ms
and never wait in one. `wide = True` on the class hides the two matrices at the top,
`camera` says from where one looks.

The modules, from the numbers to the page:

    arm, ghost                  MuJoCo's poses and the library's; the student's
    student, own                the student's files in the checker's sandbox
    words, typed                numbers as HTML; as people type them, in the URL
    shapes, meshes, draw, scene what is in the picture
    page, instruments, animate  what a tab gets
    robot                       a tab's own robot, instead of the arm
    tab, declared               what a tab is; one that a day declares
    canvas                      a picture of a plane
    standing, common_tabs       how the tasks stand; the tabs that every day has
    failing, failing_picture    a call of a task that fails, as a tab and as a picture
    app                         the page as a whole
    plain                       its numbers and sliders for a browser without 3D
    guard                       who may talk to it; our part of viser's page
    serve, recording            listens until Ctrl-C; a film without a server

`arm`, `ghost`, `words`, `typed` and `failing` need nothing new, `failing_picture` needs
Pillow (the extra `figures`), and the rest viser (the extra `view`).
"""
