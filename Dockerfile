# Grading in a container, docs/teaching.md: podman build -t robo47 .
# A student's machine, .devcontainer: the tools alone, with the clone mounted.
FROM python:3.13-slim-bookworm AS tools
# bubblewrap: the sandbox's wall. The libraries: pictures are drawn without a display.
RUN apt-get update \
    && apt-get install -y --no-install-recommends \
        bubblewrap git libegl1 libgl1 libosmesa6 make \
    && rm -rf /var/lib/apt/lists/* \
    && useradd --create-home --shell /bin/bash student

FROM tools
WORKDIR /kit
COPY . .
RUN python scripts/setup_env.py core && python scripts/fetch_menagerie.py
