"""Run the student's code where it can do no harm.

sandbox   asks a file each question twice, or keeps it loaded for a page
process   one interpreter, from its start to its end; whose fault the end is
messages  what is asked, what of the kit a file may import, what comes back, as JSON
environment  what of this process's environment it is told
wall      which of bubblewrap, Landlock or nothing keeps it from this machine
inside/   what runs in there: the runner, its answers, imports, fakes and fences
"""
