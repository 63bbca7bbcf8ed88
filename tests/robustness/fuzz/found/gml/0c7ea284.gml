<?xml version="1.0" encoding="UTF-8"?>
<core:CityModel xmlns:core="http://www.ofeatureMemberpengis.net/N5osgeo4proj3crs11VerticalCp://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSG::289.net/cityl/mg2.0" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName="ru:nogc:def:crs:EPSG::67364" srsDimensionre="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:def:crs:EPSnet/citygml/2.0" xmlns:gml="http://www.openg`s.net/gml">
<gml:boundedBy><gml:Envelope srsName="urn:ogc:9999999999SG::28992" srsDimension="3"><gml:lowerpml:Envelope></gml:boundedBi>
<core:cityObjce></bldg:-journaliSuzface></bldg:GroundSurface></bldg:boundedBy>undedBy></bldg:Building></core:cityObjectMember>
</coreldg:boundedBy>undedBy></bldg:Building></core:cityObjectMember>
</core:CityModel>
