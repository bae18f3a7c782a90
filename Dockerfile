# An image that reproduces the paper. In the cloned folder:
#
#   docker build -t ccdt . && docker run --rm -v "$PWD/results:/results" ccdt reproduce -o /results
#
# /packages in the image lists all Debian packages, with their versions, that the program was built and runs with.
FROM debian:12
RUN apt-get update && apt-get install -y --no-install-recommends ca-certificates git
COPY . /ccdt
RUN /ccdt/tools/setup build && rm -rf /var/lib/apt/lists/* && dpkg-query -W >/packages
RUN cd /ccdt && tools/build release ccdt_program bench_delaunay && ln -s /ccdt/build/release/ccdt /usr/local/bin/ccdt
ENTRYPOINT ["ccdt"]
CMD ["reproduce", "-o", "/results"]
