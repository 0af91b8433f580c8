# Two stages: the build, and an image with programs, library and book. Their steps are commands that run without Docker, too:
# `make package` makes the package, `scripts/package try` installs and uses it in a bare root.
FROM debian:bookworm AS build
RUN apt-get update -q && apt-get install -y --no-install-recommends make
COPY . /nlmech
WORKDIR /nlmech
RUN make package

FROM debian:bookworm-slim
COPY --from=build /nlmech/build/nlmech_*.deb /tmp/nlmech.deb
COPY scripts/package /tmp/package
RUN /tmp/package install /tmp/nlmech.deb && rm /tmp/nlmech.deb /tmp/package
WORKDIR /work
CMD ["bash"]
